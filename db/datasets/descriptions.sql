-- Sentences about the whole task, its start, and each skill (with the skill's frames).
SELECT i.level, s.first_frame, s.end_frame, i.text
FROM instructions i LEFT JOIN segments s ON s.episode = i.episode AND s.segment = i.segment
WHERE i.episode = ?1 ORDER BY i.ordinal;
