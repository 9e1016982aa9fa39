CREATE VIEW demos AS SELECT * FROM episodes WHERE outcome = 'success';
