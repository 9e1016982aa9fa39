CREATE VIEW preconditions AS
SELECT p.episode, e.task, e.variation, e.seed, p.undone, p.segment, s.skill, s.case_name, p.ordinal, p.choice, p.negated,
       p.predicate, p.arg1, p.arg2, p.arg3, p.arg4, p.fact,
       CASE WHEN p.negated THEN '(not ' || p.fact || ')' ELSE p.fact END AS literal, p.held
FROM segment_precondition p
JOIN episode e ON e.id = p.episode
LEFT JOIN segment s ON s.episode = p.episode AND s.undone = p.undone AND s.ordinal = p.segment;
