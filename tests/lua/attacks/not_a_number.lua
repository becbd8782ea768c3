return { format = 1, kind = "robot", name = "x", segments = { { modules = 0 / 0 } } }
