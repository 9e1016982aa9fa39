CREATE VIEW steps AS  -- one row a frame: joints 0 to 6 are the arm's, and so are the first action channels
SELECT f.episode, e.task, e.variation, e.seed, f.frame, f.time_s, j1.position AS j1, j2.position AS j2,
       j3.position AS j3, j4.position AS j4, j5.position AS j5, j6.position AS j6, j7.position AS j7,
       h.opening AS gripper, h.x, h.y, h.z, h.qx, h.qy, h.qz, h.qw,
       a1.value AS action_j1, a2.value AS action_j2, a3.value AS action_j3, a4.value AS action_j4,
       a5.value AS action_j5, a6.value AS action_j6, a7.value AS action_j7,
       a8.value AS action_x, a9.value AS action_y, a10.value AS action_z,
       a11.value AS action_qx, a12.value AS action_qy, a13.value AS action_qz, a14.value AS action_qw,
       a15.value AS action_gripper,
       f.skill_segment, s.skill, s.arguments, s.label, m.skill AS motion,
       (SELECT g.skill FROM segment g WHERE g.episode = f.episode AND g.undone = 0 AND g.kind = 'subgoal'
          AND g.first_frame <= f.frame AND f.frame < g.end_frame ORDER BY g.first_frame DESC, g.ordinal DESC LIMIT 1)
         AS subgoal, f.reward, f.done
FROM frame f
JOIN episode e ON e.id = f.episode
LEFT JOIN joint_state j1 ON j1.episode = f.episode AND j1.frame = f.frame AND j1.joint = 0
LEFT JOIN joint_state j2 ON j2.episode = f.episode AND j2.frame = f.frame AND j2.joint = 1
LEFT JOIN joint_state j3 ON j3.episode = f.episode AND j3.frame = f.frame AND j3.joint = 2
LEFT JOIN joint_state j4 ON j4.episode = f.episode AND j4.frame = f.frame AND j4.joint = 3
LEFT JOIN joint_state j5 ON j5.episode = f.episode AND j5.frame = f.frame AND j5.joint = 4
LEFT JOIN joint_state j6 ON j6.episode = f.episode AND j6.frame = f.frame AND j6.joint = 5
LEFT JOIN joint_state j7 ON j7.episode = f.episode AND j7.frame = f.frame AND j7.joint = 6
LEFT JOIN hand_state h ON h.episode = f.episode AND h.frame = f.frame AND h.hand = 0
LEFT JOIN action a1 ON a1.episode = f.episode AND a1.frame = f.frame AND a1.channel = 0
LEFT JOIN action a2 ON a2.episode = f.episode AND a2.frame = f.frame AND a2.channel = 1
LEFT JOIN action a3 ON a3.episode = f.episode AND a3.frame = f.frame AND a3.channel = 2
LEFT JOIN action a4 ON a4.episode = f.episode AND a4.frame = f.frame AND a4.channel = 3
LEFT JOIN action a5 ON a5.episode = f.episode AND a5.frame = f.frame AND a5.channel = 4
LEFT JOIN action a6 ON a6.episode = f.episode AND a6.frame = f.frame AND a6.channel = 5
LEFT JOIN action a7 ON a7.episode = f.episode AND a7.frame = f.frame AND a7.channel = 6
LEFT JOIN action a8 ON a8.episode = f.episode AND a8.frame = f.frame AND a8.channel = 7
LEFT JOIN action a9 ON a9.episode = f.episode AND a9.frame = f.frame AND a9.channel = 8
LEFT JOIN action a10 ON a10.episode = f.episode AND a10.frame = f.frame AND a10.channel = 9
LEFT JOIN action a11 ON a11.episode = f.episode AND a11.frame = f.frame AND a11.channel = 10
LEFT JOIN action a12 ON a12.episode = f.episode AND a12.frame = f.frame AND a12.channel = 11
LEFT JOIN action a13 ON a13.episode = f.episode AND a13.frame = f.frame AND a13.channel = 12
LEFT JOIN action a14 ON a14.episode = f.episode AND a14.frame = f.frame AND a14.channel = 13
LEFT JOIN action a15 ON a15.episode = f.episode AND a15.frame = f.frame AND a15.channel = 14
LEFT JOIN segment s ON s.episode = f.episode AND s.undone = 0 AND s.ordinal = f.skill_segment
LEFT JOIN segment m ON m.episode = f.episode AND m.undone = 0 AND m.ordinal = f.motion_segment;
