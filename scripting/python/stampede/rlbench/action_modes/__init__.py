"""How an action's numbers move the robot."""
