-- Where the tip of the hand is (m, world; quaternion xyzw), how it moves, its opening (m) and the force at its pads (N); every 40th frame and the one before it.
SELECT frame, hand, x, y, z, qx, qy, qz, qw, linear_x, linear_y, linear_z, angular_x, angular_y, angular_z, opening,
       touch_1, touch_2
FROM hands WHERE episode = ?1 AND frame % 40 IN (39, 0) ORDER BY frame, hand;
