local t = {}
for i = 1, 20000 do t[i] = i % 17 end
table.sort(t)
