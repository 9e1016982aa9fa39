CREATE VIEW joints AS  -- an arm's joints are those that can be commanded; where nothing was, those driven that turn
SELECT s.episode, (SELECT k.task FROM episode k WHERE k.id = s.episode) AS task,
       s.frame, f.time_s, j.name AS joint, j.kind, j.unit,
       CASE j.ordinal % 12 WHEN 0 THEN s.position_0 WHEN 1 THEN s.position_1 WHEN 2 THEN s.position_2
         WHEN 3 THEN s.position_3 WHEN 4 THEN s.position_4 WHEN 5 THEN s.position_5 WHEN 6 THEN s.position_6
         WHEN 7 THEN s.position_7 WHEN 8 THEN s.position_8 WHEN 9 THEN s.position_9 WHEN 10 THEN s.position_10
         WHEN 11 THEN s.position_11 END AS position,
       CASE j.ordinal % 12 WHEN 0 THEN s.velocity_0 WHEN 1 THEN s.velocity_1 WHEN 2 THEN s.velocity_2
         WHEN 3 THEN s.velocity_3 WHEN 4 THEN s.velocity_4 WHEN 5 THEN s.velocity_5 WHEN 6 THEN s.velocity_6
         WHEN 7 THEN s.velocity_7 WHEN 8 THEN s.velocity_8 WHEN 9 THEN s.velocity_9 WHEN 10 THEN s.velocity_10
         WHEN 11 THEN s.velocity_11 END AS velocity,
       CASE j.ordinal % 12 WHEN 0 THEN s.effort_0 WHEN 1 THEN s.effort_1 WHEN 2 THEN s.effort_2
         WHEN 3 THEN s.effort_3 WHEN 4 THEN s.effort_4 WHEN 5 THEN s.effort_5 WHEN 6 THEN s.effort_6
         WHEN 7 THEN s.effort_7 WHEN 8 THEN s.effort_8 WHEN 9 THEN s.effort_9 WHEN 10 THEN s.effort_10
         WHEN 11 THEN s.effort_11 END AS effort,
       j.lower, j.upper, j.driven,
       CASE WHEN j.driven THEN coalesce(
         (SELECT c.component + 1 FROM action_channel c WHERE c.episode = j.episode AND c.space = 'joint_position'
            AND c.name = j.name),
         (SELECT count(*) FROM joint k WHERE j.kind = 'hinge' AND k.episode = j.episode AND k.ordinal <= j.ordinal
            AND k.driven AND k.kind = 'hinge' AND NOT EXISTS
            (SELECT 1 FROM action_channel c WHERE c.episode = j.episode AND c.space = 'joint_position')
          HAVING count(*) > 0)) END AS arm_joint
FROM joint_state s
JOIN joint j ON j.episode = s.episode AND j.ordinal BETWEEN 12 * s.part AND 12 * s.part + 11
JOIN frame f ON f.episode = s.episode AND f.frame = s.frame;
