-- The object that a part or region belongs to, by its name: `chest` of `chest.top_drawer`.
return function(name)
  local dot = string.find(name, ".")
  return dot and string.sub(name, 1, dot - 1) or name
end
