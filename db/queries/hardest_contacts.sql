-- The pairs that pressed hardest against each other.
SELECT object_a, part_a, object_b, part_b, round(max(peak_force), 3) AS peak_force, count(*) AS contacts, episode
FROM contacts
GROUP BY object_a, part_a, object_b, part_b
ORDER BY max(contacts.peak_force) DESC, object_a, part_a, object_b, part_b;
