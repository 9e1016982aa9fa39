-- The planning problem at its start: PDDL domain and problem.
SELECT (SELECT text FROM problems WHERE episode = ?1 AND kind = 'pddl_domain' LIMIT 1) AS domain,
       (SELECT text FROM problems WHERE episode = ?1 AND kind = 'pddl_problem' LIMIT 1) AS problem;
