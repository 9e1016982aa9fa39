-- How often each skill succeeds at its first try, and over all tries, undone ones included.
SELECT skill, case_name, sum(try_number = 1) AS first_tries,
       round(avg(CASE WHEN try_number = 1 THEN outcome = 'success' END), 4) AS first_try_success,
       count(*) AS tries, round(avg(outcome = 'success'), 4) AS success_rate
FROM tries
WHERE kind = 'skill'
GROUP BY skill, case_name
ORDER BY skill, case_name;
