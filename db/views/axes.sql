CREATE VIEW axes AS
SELECT e.id AS episode, e.task, e.variation, e.seed, e.split, e.outcome, a.axis, a.value
FROM episode e
JOIN variation_axis a ON a.task = e.task AND a.variation = e.variation;
