error(string.format("%-20s|%s|%5.1f", {}, print, 2), 0)
