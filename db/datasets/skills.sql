-- The skill segments: frames [first_frame, end_frame), name, case, arguments (a JSON list), how each ended.
SELECT row_number() OVER (ORDER BY segment) - 1 AS ordinal, first_frame, end_frame, skill, case_name, arguments, outcome
FROM segments WHERE episode = ?1 AND kind = 'skill' ORDER BY segment;
