CREATE VIEW actions AS
SELECT a.episode, a.frame, f.time_s, c.space, c.component, c.name, c.unit, a.value
FROM action a
JOIN action_channel c ON c.episode = a.episode AND c.ordinal = a.channel
JOIN frame f ON f.episode = a.episode AND f.frame = a.frame;
