-- The predicates that can change, by name, and how many arguments each takes.
SELECT DISTINCT predicate,
       (arg1 IS NOT NULL) + (arg2 IS NOT NULL) + (arg3 IS NOT NULL) + (arg4 IS NOT NULL) AS arguments
FROM facts WHERE episode = ?1 AND predicate_kind IN ('basic', 'derived') ORDER BY predicate;
