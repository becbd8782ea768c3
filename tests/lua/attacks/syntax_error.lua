return { format = 1,, }
