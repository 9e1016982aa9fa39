-- Where the tip of the hand is (m, world; quaternion xyzw), how it moves, its opening (m) and the force at its pads (N); every 20th frame only.
SELECT frame, hand, x, y, z, qx, qy, qz, qw, linear_x, linear_y, linear_z, angular_x, angular_y, angular_z, opening,
       touch_1, touch_2
FROM hands WHERE episode = ?1 AND frame % 20 = 0 ORDER BY frame, hand;
