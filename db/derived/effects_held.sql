-- Whether declared effects were true at the end of their segments. Whoever runs it adds which episode.
UPDATE segment_effect AS d
SET held = (d.negated <> EXISTS (
  SELECT 1 FROM segment s JOIN fact f ON f.episode = s.episode
  WHERE s.episode = d.episode AND s.undone = 0 AND s.ordinal = d.segment AND f.fact = d.fact
    AND f.start_step <= s.end_step AND (+f.end_step > s.end_step OR f.open_end)))
WHERE d.undone = 0
