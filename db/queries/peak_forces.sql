-- How hard contacts pressed, by task: above 100 N is a defect of the task, where nothing fell to the floor.
SELECT task, round(max(peak_force), 1) AS peak_n, round(avg(peak_force), 2) AS mean_of_peaks_n,
       sum(peak_force > 100) AS above_100_n, count(*) AS contacts, count(DISTINCT episode) AS episodes
FROM contacts
GROUP BY task
ORDER BY max(contacts.peak_force) DESC, task;
