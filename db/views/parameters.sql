CREATE VIEW parameters AS
SELECT p.episode, p.undone, p.segment, coalesce(s.skill, a.skill) AS skill, p.name, p.component, p.value, p.text,
       p.unit,
       p.frame, p.chosen_by
FROM segment_parameter p
LEFT JOIN segment s ON NOT p.undone AND s.episode = p.episode AND s.ordinal = p.segment
LEFT JOIN attempt a ON p.undone AND a.episode = p.episode AND a.ordinal = p.segment;
