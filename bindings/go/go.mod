module peri/glass

go 1.19
