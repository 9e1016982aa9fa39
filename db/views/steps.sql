CREATE VIEW steps AS  -- one row a frame. Where the arm's joints come first of all and are seven or six, columns of rows
-- are read as they lie (l: its last joint); for other arms each is looked up by what it is.
SELECT e.id AS episode, e.task, e.variation, e.seed, f.frame, f.time_s,
       CASE WHEN l.ordinal >= 0 THEN j.position_0 WHEN l.ordinal IS NULL THEN
         (SELECT q.position FROM joints q WHERE q.episode = e.id AND q.frame = f.frame AND q.arm_joint = 1) END AS j1,
       CASE WHEN l.ordinal >= 1 THEN j.position_1 WHEN l.ordinal IS NULL THEN
         (SELECT q.position FROM joints q WHERE q.episode = e.id AND q.frame = f.frame AND q.arm_joint = 2) END AS j2,
       CASE WHEN l.ordinal >= 2 THEN j.position_2 WHEN l.ordinal IS NULL THEN
         (SELECT q.position FROM joints q WHERE q.episode = e.id AND q.frame = f.frame AND q.arm_joint = 3) END AS j3,
       CASE WHEN l.ordinal >= 3 THEN j.position_3 WHEN l.ordinal IS NULL THEN
         (SELECT q.position FROM joints q WHERE q.episode = e.id AND q.frame = f.frame AND q.arm_joint = 4) END AS j4,
       CASE WHEN l.ordinal >= 4 THEN j.position_4 WHEN l.ordinal IS NULL THEN
         (SELECT q.position FROM joints q WHERE q.episode = e.id AND q.frame = f.frame AND q.arm_joint = 5) END AS j5,
       CASE WHEN l.ordinal >= 5 THEN j.position_5 WHEN l.ordinal IS NULL THEN
         (SELECT q.position FROM joints q WHERE q.episode = e.id AND q.frame = f.frame AND q.arm_joint = 6) END AS j6,
       CASE WHEN l.ordinal >= 6 THEN j.position_6 WHEN l.ordinal IS NULL THEN
         (SELECT q.position FROM joints q WHERE q.episode = e.id AND q.frame = f.frame AND q.arm_joint = 7) END AS j7,
       h.opening AS gripper, h.x, h.y, h.z, h.qx, h.qy, h.qz, h.qw,
       CASE WHEN l.ordinal >= 0 THEN a.value_0 WHEN l.ordinal IS NULL THEN
         (SELECT q.value FROM actions q WHERE q.episode = e.id AND q.frame = f.frame AND q.space = 'joint_position' AND q.component = 0) END
         AS action_j1,
       CASE WHEN l.ordinal >= 1 THEN a.value_1 WHEN l.ordinal IS NULL THEN
         (SELECT q.value FROM actions q WHERE q.episode = e.id AND q.frame = f.frame AND q.space = 'joint_position' AND q.component = 1) END
         AS action_j2,
       CASE WHEN l.ordinal >= 2 THEN a.value_2 WHEN l.ordinal IS NULL THEN
         (SELECT q.value FROM actions q WHERE q.episode = e.id AND q.frame = f.frame AND q.space = 'joint_position' AND q.component = 2) END
         AS action_j3,
       CASE WHEN l.ordinal >= 3 THEN a.value_3 WHEN l.ordinal IS NULL THEN
         (SELECT q.value FROM actions q WHERE q.episode = e.id AND q.frame = f.frame AND q.space = 'joint_position' AND q.component = 3) END
         AS action_j4,
       CASE WHEN l.ordinal >= 4 THEN a.value_4 WHEN l.ordinal IS NULL THEN
         (SELECT q.value FROM actions q WHERE q.episode = e.id AND q.frame = f.frame AND q.space = 'joint_position' AND q.component = 4) END
         AS action_j5,
       CASE WHEN l.ordinal >= 5 THEN a.value_5 WHEN l.ordinal IS NULL THEN
         (SELECT q.value FROM actions q WHERE q.episode = e.id AND q.frame = f.frame AND q.space = 'joint_position' AND q.component = 5) END
         AS action_j6,
       CASE WHEN l.ordinal >= 6 THEN a.value_6 WHEN l.ordinal IS NULL THEN
         (SELECT q.value FROM actions q WHERE q.episode = e.id AND q.frame = f.frame AND q.space = 'joint_position' AND q.component = 6) END
         AS action_j7,
       CASE l.ordinal WHEN 6 THEN a.value_7 WHEN 5 THEN a.value_6 ELSE
         (SELECT q.value FROM actions q WHERE q.episode = e.id AND q.frame = f.frame AND q.space = 'tool_pose' AND q.component = 0) END
         AS action_x,
       CASE l.ordinal WHEN 6 THEN a.value_8 WHEN 5 THEN a.value_7 ELSE
         (SELECT q.value FROM actions q WHERE q.episode = e.id AND q.frame = f.frame AND q.space = 'tool_pose' AND q.component = 1) END
         AS action_y,
       CASE l.ordinal WHEN 6 THEN a.value_9 WHEN 5 THEN a.value_8 ELSE
         (SELECT q.value FROM actions q WHERE q.episode = e.id AND q.frame = f.frame AND q.space = 'tool_pose' AND q.component = 2) END
         AS action_z,
       CASE l.ordinal WHEN 6 THEN a.value_10 WHEN 5 THEN a.value_9 ELSE
         (SELECT q.value FROM actions q WHERE q.episode = e.id AND q.frame = f.frame AND q.space = 'tool_pose' AND q.component = 3) END
         AS action_qx,
       CASE l.ordinal WHEN 6 THEN a.value_11 WHEN 5 THEN a.value_10 ELSE
         (SELECT q.value FROM actions q WHERE q.episode = e.id AND q.frame = f.frame AND q.space = 'tool_pose' AND q.component = 4) END
         AS action_qy,
       CASE l.ordinal WHEN 6 THEN a.value_12 WHEN 5 THEN a.value_11 ELSE
         (SELECT q.value FROM actions q WHERE q.episode = e.id AND q.frame = f.frame AND q.space = 'tool_pose' AND q.component = 5) END
         AS action_qz,
       CASE l.ordinal WHEN 6 THEN a.value_13 WHEN 5 THEN a.value_12 ELSE
         (SELECT q.value FROM actions q WHERE q.episode = e.id AND q.frame = f.frame AND q.space = 'tool_pose' AND q.component = 6) END
         AS action_qw,
       CASE l.ordinal WHEN 6 THEN a.value_14 WHEN 5 THEN a.value_13 ELSE
         (SELECT q.value FROM actions q WHERE q.episode = e.id AND q.frame = f.frame AND q.space = 'gripper') END
         AS action_gripper,
       f.skill_segment, s.skill, s.arguments, s.label, f.motion, f.subgoal, f.reward, f.done
FROM episode e
LEFT JOIN joint l ON l.episode = e.id
  AND l.ordinal = (SELECT count(*) - 1 FROM action_channel c WHERE c.episode = e.id AND c.space = 'joint_position')
  AND l.name = (SELECT c.name FROM action_channel c WHERE c.episode = e.id AND c.ordinal = l.ordinal)
CROSS JOIN frame f ON f.episode = e.id
LEFT JOIN joint_state j ON j.episode = f.episode AND j.frame = f.frame AND j.part = 0
LEFT JOIN hand_state h ON h.episode = f.episode AND h.frame = f.frame AND h.hand = 0
LEFT JOIN action a ON a.episode = f.episode AND a.frame = f.frame AND a.part = 0
LEFT JOIN segment s ON s.episode = f.episode AND s.undone = 0 AND s.ordinal = f.skill_segment;
