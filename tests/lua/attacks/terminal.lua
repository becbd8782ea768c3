error("\27[2Jgone\7 \xC2\x9B31m", 0)
