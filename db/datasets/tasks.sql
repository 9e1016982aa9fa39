-- What the episode is one of, and how it ended.
SELECT task, world, variation, outcome FROM episodes WHERE episode = ?1;
