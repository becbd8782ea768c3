# Run by `cmake --install`: only then is the prefix known, and a unit has to name its program by its whole path.
configure_file("${UNIT_INPUT}" "${UNIT_FOLDER}/lianad@.service" @ONLY)
