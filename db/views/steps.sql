CREATE VIEW steps AS  -- one row a frame: joints 0 to 6 are the arm's, and so are the first action channels
SELECT f.episode, e.task, e.variation, e.seed, f.frame, f.time_s, j.position_0 AS j1, j.position_1 AS j2,
       j.position_2 AS j3, j.position_3 AS j4, j.position_4 AS j5, j.position_5 AS j6, j.position_6 AS j7,
       h.opening AS gripper, h.x, h.y, h.z, h.qx, h.qy, h.qz, h.qw, a.value_0 AS action_j1, a.value_1 AS action_j2,
       a.value_2 AS action_j3, a.value_3 AS action_j4, a.value_4 AS action_j5, a.value_5 AS action_j6,
       a.value_6 AS action_j7, a.value_7 AS action_x, a.value_8 AS action_y, a.value_9 AS action_z,
       a.value_10 AS action_qx, a.value_11 AS action_qy, a.value_12 AS action_qz, a.value_13 AS action_qw,
       a.value_14 AS action_gripper, f.skill_segment, s.skill, s.arguments, s.label, f.motion,
       f.subgoal, f.reward, f.done
FROM frame f
JOIN episode e ON e.id = f.episode
LEFT JOIN joint_state j ON j.episode = f.episode AND j.frame = f.frame AND j.part = 0
LEFT JOIN hand_state h ON h.episode = f.episode AND h.frame = f.frame AND h.hand = 0
LEFT JOIN action a ON a.episode = f.episode AND a.frame = f.frame AND a.part = 0
LEFT JOIN segment s ON s.episode = f.episode AND s.undone = 0 AND s.ordinal = f.skill_segment;
