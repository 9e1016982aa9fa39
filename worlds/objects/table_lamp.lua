-- A small table lamp with a bare globe for a bulb, which shines once its button has been pressed.
return require("worlds.lib.lamps").table_lamp()
