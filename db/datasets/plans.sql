-- The plan that was followed, a ground skill a line.
SELECT plan, steps FROM plans WHERE episode = ?1;
