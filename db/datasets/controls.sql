-- What moved the arm: motions [first_frame, end_frame) and the controller of each.
SELECT first_frame, end_frame, skill AS motion, controller, outcome
FROM segments WHERE episode = ?1 AND kind IN ('motion', 'control') ORDER BY segment;
