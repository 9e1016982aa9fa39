CREATE VIEW episodes AS
SELECT e.id AS episode, e.key, e.task, e.world, e.variation, e.seed, e.split, e.outcome, e.reason, e.detail, e.beside_goal, e.frames,
       e.steps, e.duration_s, e.physics_hz, e.frame_hz, e.draws, e.state_hash, e.source, e.scene,
       (SELECT count(*) FROM segment s WHERE s.episode = e.id AND s.undone = 0 AND s.kind = 'skill') AS skills,
       (SELECT count(*) FROM segment s WHERE s.episode = e.id AND s.undone = 1 AND s.kind = 'skill') AS undone,
       r.engine_version, r.numerics, r.options, t.wall_s, t.physics_wall_s
FROM episode e
JOIN engine_run r ON r.hash = e.engine_run
LEFT JOIN timing t ON t.episode = e.id;
