# `cmake --build ... --target uninstall`: what the last `cmake --install` of this build folder installed.
if(NOT EXISTS "${MANIFEST}")
  message(FATAL_ERROR "${MANIFEST}: nothing was installed from this build folder; "
                      "cmake -P PREFIX/share/liana/uninstall.cmake removes what another one installed")
endif()
file(STRINGS "${MANIFEST}" script REGEX "/share/liana/uninstall\\.cmake$")
if(NOT EXISTS "$ENV{DESTDIR}${script}")
  message(FATAL_ERROR "$ENV{DESTDIR}${script}: is not there: the prefix was moved or removed; "
                      "cmake -P PREFIX/share/liana/uninstall.cmake removes what was moved")
endif()
include("$ENV{DESTDIR}${script}")
