CREATE VIEW plans AS
SELECT d.episode, e.task, e.variation, e.seed, e.outcome, t.body AS plan,
       (length(t.body) - length(replace(t.body, '(', ''))) AS steps
FROM document d
JOIN episode e ON e.id = d.episode
JOIN text_store t ON t.hash = d.text
WHERE d.kind = 'plan';
