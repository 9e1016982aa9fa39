CREATE VIEW observed_facts AS  -- facts of predicates that never hide, and of the others what was known
SELECT f.episode, e.task, e.variation, e.seed, f.predicate, f.arg1, f.arg2, f.arg3, f.arg4, f.fact,
       f.start_step * 1.0 / e.physics_hz AS start_s, f.end_step * 1.0 / e.physics_hz AS end_s, f.start_step, f.end_step,
       f.first_frame, f.end_frame, f.open_start, f.open_end
FROM (SELECT episode, predicate, arg1, arg2, arg3, arg4, fact, start_step, end_step, first_frame, end_frame, open_start,
             open_end
      FROM observed_fact
      UNION ALL
      SELECT episode, predicate, arg1, arg2, arg3, arg4, fact, start_step, end_step, first_frame, end_frame, open_start,
             open_end
      FROM fact k
      WHERE NOT EXISTS (SELECT 1 FROM observed_fact o WHERE o.episode = k.episode AND o.predicate = k.predicate)
        AND NOT EXISTS (SELECT 1 FROM fact h
                        WHERE h.episode = k.episode AND h.predicate = k.predicate AND h.observed = 0)) f
JOIN episode e ON e.id = f.episode;
