-- Of each skill segment (ordinal, as in skills) facts before and after, what changed, and the declared effects (JSON lists).
SELECT row_number() OVER (ORDER BY segment) - 1 AS ordinal, skill, case_name, before, after, added, removed, declared,
       missing, undeclared
FROM transitions WHERE episode = ?1 AND kind = 'skill' ORDER BY segment;
