CREATE VIEW observed_facts AS  -- facts of predicates that never hide, and of the others what was known
WITH hides AS (SELECT episode, predicate FROM observed_fact UNION SELECT episode, predicate FROM fact WHERE observed = 0)
SELECT f.episode, e.task, e.variation, e.seed, f.predicate, f.arg1, f.arg2, f.arg3, f.arg4, f.fact,
       f.start_step * 1.0 / e.physics_hz AS start_s, f.end_step * 1.0 / e.physics_hz AS end_s, f.start_step, f.end_step,
       f.first_frame, f.end_frame, f.open_start, f.open_end
FROM (SELECT episode, predicate, arg1, arg2, arg3, arg4, fact, start_step, end_step, first_frame, end_frame, open_start,
             open_end
      FROM observed_fact
      UNION ALL
      SELECT episode, predicate, arg1, arg2, arg3, arg4, fact, start_step, end_step, first_frame, end_frame, open_start,
             open_end
      FROM fact WHERE (episode, predicate) NOT IN (SELECT episode, predicate FROM hides)) f
JOIN episode e ON e.id = f.episode;
