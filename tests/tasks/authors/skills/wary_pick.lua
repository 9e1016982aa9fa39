-- As pick, but nothing that is guarded.
return skill { extends = "pick", precondition = { is_not(exists("?guard: movable", is.guards("?guard", "obj"))) } }
