-- Of each skill segment (ordinal, as in skills) the literals of its precondition, ground.
SELECT s.ordinal, p.skill, p.case_name, p.literal, p.choice, p.held
FROM preconditions p
JOIN (SELECT segment, row_number() OVER (ORDER BY segment) - 1 AS ordinal FROM segments
      WHERE episode = ?1 AND kind = 'skill') s ON s.segment = p.segment
WHERE p.episode = ?1 AND NOT p.undone ORDER BY s.ordinal, p.ordinal;
