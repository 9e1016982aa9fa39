-- Asks for a thing that is not there.
return predicate { params = { "obj: movable" }, label = "broken", holds = function(w, obj) return w:joint("nothing") > 0 end }
