local t = { 1, 2, 3, 4, 5, 6, 7, 8 }
for _ = 1, 20 do t = { t, t, t } end
return t
