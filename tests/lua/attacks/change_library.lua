string.rep = function() return "" end
