CREATE VIEW masks AS
SELECT m.episode, (SELECT k.task FROM episode k WHERE k.id = m.episode) AS task,
       m.instance, m.name, m.object, m.class, m.semantic, m.colour
FROM mask m;
