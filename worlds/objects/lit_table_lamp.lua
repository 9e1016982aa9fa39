-- A small table lamp with a bare globe for a bulb, which shines until its button is pressed.
return require("worlds.lib.lamps").table_lamp(true)
