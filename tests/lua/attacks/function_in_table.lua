return { format = 1, kind = "buses", name = function() end }
