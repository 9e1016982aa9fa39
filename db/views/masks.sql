CREATE VIEW masks AS
SELECT m.episode, m.instance, m.name, m.object, m.class, m.semantic, m.colour
FROM mask m;
