local text, list = string.rep("x", 1000000), {}
for i = 1, 1000 do list[i] = text end
return list
