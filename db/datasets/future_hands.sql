-- Where the tip of the hand is 1, 5 and 20 frames after every 40th frame (m, world).
SELECT frame, hand AS object, x, y, z FROM hands WHERE episode = ?1 AND frame % 40 IN (0, 1, 5, 20) ORDER BY frame, hand;
