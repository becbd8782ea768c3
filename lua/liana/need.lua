-- Refuses an argument of a condition or action that has another type, at the user's line: need("at_pose", "name", name, "string").
return function(what, argument, value, kind)
  if type(value) == kind then return end
  error(("%s: %s: %s: allowed a %s: correct the call"):format(what, argument, tostring(value), kind), 3)
end
