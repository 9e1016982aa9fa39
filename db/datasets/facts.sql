-- When each fact held: frames [first_frame, end_frame).
SELECT predicate, arg1, arg2, arg3, arg4, fact, first_frame, end_frame, open_end, predicate_kind
FROM facts WHERE episode = ?1 ORDER BY first_frame, fact, end_frame;
