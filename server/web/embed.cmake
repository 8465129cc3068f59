# Writes ${CMAKE_CURRENT_BINARY_DIR}/embedded_pages.cpp: the files of this directory as raw strings. A changed file makes
# the next build configure again.
foreach(file index.html docs.html docs.js style.css)
  set(path ${CMAKE_CURRENT_LIST_DIR}/${file})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
  file(READ ${path} text)
  string(MAKE_C_IDENTIFIER ${file} name)
  set(embedded_${name} "R\"page(${text})page\"")
endforeach()
configure_file(${CMAKE_CURRENT_LIST_DIR}/pages.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/embedded_pages.cpp @ONLY)
