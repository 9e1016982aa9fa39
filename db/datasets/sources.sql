-- Which episode of the catalogue this is.
SELECT key, task, variation, seed, outcome FROM episodes WHERE episode = ?1;
