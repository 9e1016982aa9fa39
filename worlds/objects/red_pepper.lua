-- A red bell pepper.
return require "worlds.lib.pepper" "red"
