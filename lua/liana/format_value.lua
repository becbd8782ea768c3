-- A value as messages have it. Which sign a NaN has is chance, and tells nobody anything.
return function(value) return value ~= value and "nan" or tostring(value) end
