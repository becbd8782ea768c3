# Run by `cmake --install`: what `./dev view` has built until then; without it no empty folder stays.
foreach(page console.html view.html core.wasm try.html)
  if(EXISTS "${PAGE_FOLDER}/${page}")
    file(INSTALL "${PAGE_FOLDER}/${page}" DESTINATION "${CMAKE_INSTALL_PREFIX}/${PAGE_DESTINATION}")
  endif()
endforeach()
