-- The robot's joints while the skill runs, frames counted from its first: which joint of the arm it is (1: next to the base; NULL: a finger), position and velocity (rad, m), effort (N m, N).
SELECT j.frame - s.first_frame AS frame, j.joint, j.arm_joint, j.position, j.velocity, j.effort
FROM segments s JOIN joints j ON j.episode = s.episode AND j.frame >= s.first_frame AND j.frame < s.end_frame
WHERE s.episode = ?1 AND s.segment = ?2 AND j.driven ORDER BY j.frame, j.arm_joint NULLS LAST, j.joint;
