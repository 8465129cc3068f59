# Writes ${CMAKE_CURRENT_BINARY_DIR}/embedded_scenes.cpp: each *.json of this directory and the problem sheet as raw
# strings. A new or changed file makes the next build configure again.
file(GLOB scene_files CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.json)
set(sheet_file ${CMAKE_CURRENT_LIST_DIR}/../problems.json)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${scene_files} ${sheet_file})

set(embedded_scenes "")
foreach(file IN LISTS scene_files)
  file(READ ${file} text)
  cmake_path(GET file FILENAME name)
  if(name STREQUAL "schema.json")
    set(embedded_schema "R\"json(${text})json\"")
  else()
    string(APPEND embedded_scenes "    {\"${name}\", R\"json(${text})json\"},\n")
  endif()
endforeach()
file(READ ${sheet_file} text)
set(embedded_problems "R\"json(${text})json\"")
configure_file(${CMAKE_CURRENT_LIST_DIR}/embedded.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/embedded_scenes.cpp @ONLY)
