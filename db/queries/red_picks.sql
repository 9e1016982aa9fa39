-- Every pick of a red object with its tested effects.
SELECT s.episode, s.segment, s.arg1 AS object, s.start_s, s.end_s, s.outcome, s.effect_held, s.missing_effects
FROM segments s
JOIN objects o ON o.episode = s.episode AND o.object = s.arg1
WHERE s.kind = 'skill' AND s.skill = 'pick' AND o.colour = 'red'
ORDER BY s.episode, s.segment;
