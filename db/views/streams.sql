CREATE VIEW streams AS
SELECT s.episode, e.task, s.ordinal, s.kind, s.name, s.file, s.clock, s.offset_s, s.drift_ppm, s.reference_s,
       s.origin_s, s.rate_hz, s.readings, s.longest_gap_s, s.missing, s.rule
FROM stream s
JOIN episode e ON e.id = s.episode;
