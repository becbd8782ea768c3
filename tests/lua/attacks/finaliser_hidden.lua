local meta = setmetatable({}, { __index = { __gc = function() while true do end end } })
setmetatable({}, meta) -- __gc is looked up raw: no finaliser, so nothing runs
meta.__gc = function() while true do end end -- too late to count
for _ = 1, 1000 do local _ = ("x"):rep(10000) end
error "the end is reached"
