while true do pcall(function() local s = ("x"):rep(1000000) for _ = 1, 40 do s = s .. s end end) end
