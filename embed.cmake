# Files inside the program. embed(<target> <header> <function> <files>) writes the definition of
#   std::span<const qdot::api::EmbeddedFile> <function>();
# which <header> declares; <function> is its whole name. A changed file makes the next build configure again.
function(embed target header function)
  set(texts "")
  foreach(file IN LISTS ARGN)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} text)
    cmake_path(GET file FILENAME name)
    string(APPEND texts "      {\"${name}\", R\"embedded(${text})embedded\"},\n")
  endforeach()
  string(MAKE_C_IDENTIFIER ${function} name)
  set(definition ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  file(CONFIGURE OUTPUT ${definition} @ONLY CONTENT
[[// Written by embed.cmake.

#include "@header@"

std::span<const qdot::api::EmbeddedFile> @function@() {
  static constexpr qdot::api::EmbeddedFile files[] = {
@texts@  };
  return files;
}
]])
  target_sources(${target} PRIVATE ${definition})
endfunction()
