-- A green bell pepper.
return require "worlds.lib.pepper" "green"
