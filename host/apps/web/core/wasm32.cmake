# Toolchain: WebAssembly with Debian's WASI library, for node and browsers.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_EXE_LINKER_FLAGS_INIT -Wl,-z,stack-size=1048576)  # the default of 64 kB is less than two controllers
# clang takes options of another processor with a warning, so the core's look at what the compiler knows is answered here.
foreach(feature fma fma4 avx512f)
  set(LIANA_COMPILER_KNOWS_${feature} OFF CACHE INTERNAL "")
endforeach()
