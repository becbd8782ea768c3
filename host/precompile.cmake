# Headers that most sources read, compiled once. No source may rely on it: preset dev compiles without.

# Clang wants the same features of the processor wherever precompiled headers are read: those of the core.
function(share_target_options target)
  if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    target_compile_options(${target} PRIVATE $<TARGET_PROPERTY:liana_core,INTERFACE_COMPILE_OPTIONS>)
  endif()
endfunction()

# precompile(NAME FOLDER... HEADERS HEADER...): for every target at or below these folders that has no such headers of
# its own. Their options must agree with those of the folder that calls this; the compiler says where they do not.
function(precompile name)
  cmake_parse_arguments(PARSE_ARGV 1 given "" "" "HEADERS")
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp "")
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_precompile_headers(${name} PRIVATE ${given_HEADERS})
  share_target_options(${name})
  while(given_UNPARSED_ARGUMENTS)
    list(POP_FRONT given_UNPARSED_ARGUMENTS folder)
    get_property(below DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
    list(APPEND given_UNPARSED_ARGUMENTS ${below})
    get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
    foreach(target ${targets})
      get_target_property(type ${target} TYPE)
      get_target_property(own ${target} PRECOMPILE_HEADERS)
      if(type MATCHES "STATIC|OBJECT|EXECUTABLE" AND NOT own)
        target_precompile_headers(${target} REUSE_FROM ${name})
        share_target_options(${target})
      endif()
    endforeach()
  endwhile()
endfunction()

set(LIANA_STANDARD_HEADERS <algorithm> <array> <charconv> <chrono> <cmath> <cstdint> <cstdio> <cstring> <deque>
    <filesystem> <fstream> <functional> <limits> <map> <memory> <numbers> <optional> <span> <sstream> <stdexcept>
    <string> <string_view> <thread> <tuple> <type_traits> <utility> <variant> <vector>)
