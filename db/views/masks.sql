CREATE VIEW masks AS
SELECT m.episode, m.instance, m.name, m.object, m.class, m.semantic,
       (SELECT a.value FROM object o JOIN object_attribute a ON a.episode = o.episode AND a.object = o.ordinal
        WHERE o.episode = m.episode AND o.name = m.object AND a.name = 'colour') AS colour
FROM mask m;
