-- Why tries and episodes failed, most frequent first, undone tries included.
SELECT level, kind, skill, reason, count(*) AS failures, sum(undone) AS undone
FROM failures
GROUP BY level, kind, skill, reason
ORDER BY failures DESC, level, kind, skill, reason;
