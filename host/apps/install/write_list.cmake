# Run last by `cmake --install`: leaves a list of all files, relative to the prefix, for uninstall.cmake beside it.
set(lines "${LIST}\n")
foreach(file IN LISTS CMAKE_INSTALL_MANIFEST_FILES)
  file(RELATIVE_PATH relative "${CMAKE_INSTALL_PREFIX}" "${file}")
  string(APPEND lines "${relative}\n")
endforeach()
file(WRITE "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/${LIST}" "${lines}")
list(APPEND CMAKE_INSTALL_MANIFEST_FILES "${CMAKE_INSTALL_PREFIX}/${LIST}")
