return { format = 1, kind = "scene", boxes = { 1, 2, x = 3 } }
