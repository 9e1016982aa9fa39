CREATE VIEW problems AS
SELECT d.episode, e.task, e.variation, e.seed, d.kind, t.hash, t.body AS text
FROM document d
JOIN episode e ON e.id = d.episode
JOIN text_store t ON t.hash = d.text
WHERE d.kind <> 'plan';
