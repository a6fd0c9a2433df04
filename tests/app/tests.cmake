# Invented reports, which the page's tests open in a browser.
add_executable(sample_report app/report/sample_report.cpp app/report/sample_data.cpp
               app/report/sample_pictures.cpp)
target_link_libraries(sample_report PRIVATE pssmlt_app pssmlt_flags)
