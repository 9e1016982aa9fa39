CREATE VIEW parameters AS
SELECT p.episode, (SELECT k.task FROM episode k WHERE k.id = p.episode) AS task,
       p.undone, p.segment, s.skill, p.name, p.component, p.value, p.text, p.unit, p.frame, p.chosen_by
FROM segment_parameter p
LEFT JOIN segment s ON s.episode = p.episode AND s.undone = p.undone AND s.ordinal = p.segment;
