CREATE VIEW verdicts AS
SELECT v.episode, e.task, e.variation, e.seed, e.outcome, v.dialect, v.theirs, v.ours,
       v.theirs = v.ours AND v.disagreements = '[]' AS agree, v.disagreements
FROM verdict v
JOIN episode e ON e.id = v.episode;
