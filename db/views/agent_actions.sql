CREATE VIEW agent_actions AS
SELECT a.episode, e.task, e.variation, e.seed, a.ordinal, a.frame, a.frame * 1.0 / e.frame_hz AS time_s, a.end_frame,
       a.space, a.numbers, a.gripper, a.reference, a.controller, a.most_frames, a.skill, a.arguments, a.parameters,
       a.segment, a.reward, a.terminated, a.truncated
FROM agent_action a
JOIN episode e ON e.id = a.episode;
