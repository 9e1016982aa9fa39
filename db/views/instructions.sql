CREATE VIEW instructions AS
SELECT l.episode, e.task, e.variation, e.seed, e.outcome, l.ordinal, l.level, l.segment, l.text, l.source, l.grain,
       l.model
FROM language l
JOIN episode e ON e.id = l.episode;
