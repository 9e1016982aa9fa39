-- Which skill ran, on what (a JSON list), and how it ended.
SELECT skill, case_name, arguments, outcome FROM segments WHERE episode = ?1 AND segment = ?2;
